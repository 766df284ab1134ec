"""What we make of JAX."""
