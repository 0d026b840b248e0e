"""The solution as a tree: words, numbers and figures in their places, before any format."""
