"""Scripts of the engine for a `solve:` that names one: the problem's `given:` then describes all there is."""
