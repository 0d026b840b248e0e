"""What parts may ask for by name, each derived when it is first asked for."""
