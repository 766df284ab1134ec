"""How wingbeat uses JAX: settings, compiled programs on disk, elementary functions and their derivatives."""
