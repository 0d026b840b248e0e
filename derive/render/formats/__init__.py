"""Each format in which a page is given out."""
