"""A page in lines of text, of TeX and of JSON."""
