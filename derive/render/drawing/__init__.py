"""Makes the drawings: projects the marks onto the paper, places the labels, and writes PDF and SVG."""
