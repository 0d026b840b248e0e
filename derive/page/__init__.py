"""The solution as a tree of words, numbers and figures in the order of the page; the formats print this tree."""
