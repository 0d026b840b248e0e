"""First integrals, motion in one dimension, steady motions, static friction, loss of contact and free flight."""
