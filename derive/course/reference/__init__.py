"""The formulas of an existing document, compared with what was derived."""
