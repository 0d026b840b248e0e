"""The drawings of a script: projected onto paper, labelled, and laid out on a sheet."""
