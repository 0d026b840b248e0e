"""What a script draws, projected, lettered and laid out on a sheet."""
