"""Prints the tree of a page in every format, and makes drawings. It writes no files and starts no subprocesses."""
