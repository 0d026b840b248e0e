"""Bodies: their shape, their density, their centre of mass, and the integrals over them."""
