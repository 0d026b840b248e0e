"""The keys of a description, and the functions that read their values in the declared symbols."""
