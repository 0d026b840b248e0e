"""Scripts that the engine offers: `solve:` names one of them, and `given:` describes the bodies or the system."""
