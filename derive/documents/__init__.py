"""Reads worked documents that others wrote: their formulas, the statements these make, and the words around them.

    source      the text of a document, and for each character of the tidied text its place in the file
    tokens      the tokens of a formula, with their places and the macros that they came from
    macros      the commands that a document defines
    layout      the formulas of a document: blocks, rows, statements, formulas in sentences, headings, cues
    syntax      the nodes of a formula as it is written; what is ambiguous keeps its alternatives
    parser      the tokens of a formula as nodes
    facts       what the whole document shows about its letters: functions, vectors, indices, definitions
    choices     the alternative that these facts select
    meaning     the nodes as expressions of SymPy

Every layer reads what is written; a slip of the author is neither refused nor repaired here.
"""
