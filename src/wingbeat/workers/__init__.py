"""Worker processes: how we communicate with them, which core each uses, what must be cleared when they end."""
