"""Sets of problems as files for learning platforms and word processors; each module writes one format."""
