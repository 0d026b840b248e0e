"""The heavy symmetric top: Euler's angles, steady precession, the sleeping top."""
