"""What a description may say, key by key, and what that means in its letters."""
