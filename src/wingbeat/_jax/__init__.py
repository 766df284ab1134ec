"""What wingbeat makes of JAX: its settings, programs kept on disk, elementary functions and their derivatives."""
