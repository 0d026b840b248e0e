"""Scripts of the engine. A problem names one under `solve:` and describes the whole system under `given:`."""
