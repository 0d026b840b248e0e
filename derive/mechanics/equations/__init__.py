"""What is made of equations: conserved quantities, small oscillations, stability, roots and conditions."""
