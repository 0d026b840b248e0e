"""Follows the reasoning of a worked document row by row, and says which rows do not follow and why.

assumptions     equations and kinds of letters that the reader of the document states
claims          what a document claims: pairs of neighbouring sides of its statements, in their order
knowledge       the definitions, equations and numbers that earlier rows gave
systems         what follows from several earlier equations: combinations, equations of motion, roots
fingerprint     the values of an expression at fixed points
numeric         numbers for expressions and nodes at fixed points
points          points at which earlier equations hold
dimensions      the dimensions that the rows give to letters, and the row that contradicts all others
deciding        the verdict on one claim
nearest_change  whether a row that does not follow would follow after one change
slips           the nearest change that would make a wrong row right
expected        the comparison of a document with the results of a derivation
reading         the claims of a document, in their order
memory          what the audit remembers of the claims before the current one
changes         the small change after which a claim would follow
blame           the earlier row that makes later rows wrong
accusing        the rows that do not follow, but would follow after one small change
copied_rows     a row that was copied from a similar row, with one index unchanged
auditing        the audit of a whole document
report          the verdicts as text, JSON and HTML
time_limit      the limit of processor time for one claim
"""
