"""The parts of examples/make_parts.py. Every part module has functions that return (text, length of the cuts in mm)."""
