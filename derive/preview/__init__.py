"""The page of a problem in a browser while somebody writes it: a warm worker, a server on this machine alone."""
