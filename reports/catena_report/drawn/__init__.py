"""The back ends that draw a figure.Figure."""
