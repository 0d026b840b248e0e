"""What each command of `derive` does, one module for each group of them."""
