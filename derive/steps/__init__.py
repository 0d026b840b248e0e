"""A verified step, the one function that makes it, and the path from the answers back to what they depend on."""
