"""Shows the page of a problem in a browser while you edit the problem, and accepts requests from this machine only."""
