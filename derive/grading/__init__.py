"""Grades the answers that students typed, and says how each answer was read, whether it is right, and what is wrong.

    names          the symbols of a problem, and which symbol a typed letter means
    typed_text     the text of an answer, tidied: ASCII and Unicode as LaTeX, split into statements
    reading        the statements as expressions in the symbols of the problem
    reading_latex  the reading of an answer, as LaTeX
    key            the answers that a problem asks for, with their dimensions, numbers and points
    outcomes       the verdicts, and the share of the points that each earns
    comparing      the verdict on a formula
    structure      the slip in a wrong formula: a factor, a sign or a term
    decimals       the verdict on a number: value, unit and figures
    relations      the verdict on an equation or an inequality
    grading        the verdict on an answer of a part, within a limited time
    table          many answers at once, as CSV
    report         the verdicts as text and JSON

An answer is untrusted data: no part of it is executed as code, and its size and the time for it are limited.
"""
