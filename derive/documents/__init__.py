"""Reads worked documents of other authors: the formulas, the statements in the formulas, and the words around them.

    source      the text of a document, and for each character of the tidied text its place in the file
    tokens      the tokens of a formula, with their places and the macros that they came from
    macros      the commands that a document defines
    layout      the formulas of a document: blocks, rows, statements, formulas in sentences, headings, cues
    syntax      the nodes of a formula as it is written; an ambiguous node keeps its alternatives
    parser      the tokens of a formula as nodes
    facts       what the whole document shows about its letters: functions, vectors, indices, definitions
    choices     the alternative that these facts select
    meaning     the nodes as expressions of SymPy

    vocabulary  the commands of LaTeX, sorted by their meaning

No layer rejects or corrects a slip of the author.
"""
