"""Scripts of the engine: `solve:` names one of them, and `given:` describes the system, the bodies or the rotation."""
