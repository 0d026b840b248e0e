"""Sets of problems as files for learning platforms and word processors."""
