"""First integrals, motion in one dimension, steady motions, loss of contact."""
