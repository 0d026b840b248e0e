"""The laws, the second routes and what chooses the words, changed one place at a time in their syntax tree.

Whatever uses the changed place must refuse it, or print the page that it printed before. `python -P -m tests.mutation`.
"""
