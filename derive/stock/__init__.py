"""Scripts that the engine offers: `solve:` names one of them, and `given:` describes the system, the bodies or the rotation."""
