"""The keys of a description, and how their values are read in its symbols."""
