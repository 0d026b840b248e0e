"""Follows the reasoning of a worked document row by row, and says which rows do not follow and why.

claims     what a document claims: pairs of neighbouring sides of its statements, in their order
known      the definitions and equations that earlier rows gave, and what follows from them
deciding   the verdict on one claim
slips      the nearest change that would make a wrong row right
auditing   the audit of a whole document
report     the verdicts as text, JSON and HTML
"""
