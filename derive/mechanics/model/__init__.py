"""A system of bodies: forces, constraints, and d'Alembert's principle, on which second routes are based."""
