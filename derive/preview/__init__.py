"""Shows the page of a problem in a browser while you write it; the server answers this machine only."""
