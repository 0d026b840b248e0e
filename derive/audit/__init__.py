"""Follows the reasoning of a worked document row by row, and says which rows do not follow and why.

assumed    equations and kinds of letters that the reader of the document states
claims     what a document claims: pairs of neighbouring sides of its statements, in their order
known      the definitions and equations that earlier rows gave, and what follows from them
systems    what earlier equations give together: combinations, equations of motion, roots
numeric    numbers for expressions and nodes at fixed points
dimensions the dimensions that the rows give to letters, and the row that contradicts all others
deciding   the verdict on one claim
near       whether a row that does not follow would follow after one change
slips      the nearest change that would make a wrong row right
expected   the comparison of a document with the results of a derivation
auditing   the audit of a whole document
report     the verdicts as text, JSON and HTML
"""
