"""Shows the page of a problem in a browser while you write it; it accepts requests from this machine only."""
