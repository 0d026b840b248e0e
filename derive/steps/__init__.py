"""A verified step, the one door through which it is made, and the walk back from the answers to what they rest on."""
