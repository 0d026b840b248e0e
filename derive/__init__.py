"""Worked solutions of mechanics problems: derived, checked line by line, typeset."""
