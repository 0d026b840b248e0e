"""The formulas of an existing document, compared with the derived steps."""
