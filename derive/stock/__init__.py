"""Scripts of the engine, for a `solve:` that names one: `given:` then describes what the script solves."""
