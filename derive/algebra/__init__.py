"""The expressions of mechanics, and when two of them are equal: no physics, no pages."""
