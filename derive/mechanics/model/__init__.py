"""A system of bodies: forces, constraints, and d'Alembert's principle, the ground of second routes."""
