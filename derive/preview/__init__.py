"""The page of a problem in a browser while you write it: a warm worker, a server on this machine alone."""
