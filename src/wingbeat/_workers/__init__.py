"""Worker processes: how we communicate with them, which core each uses, and what we clear when they end."""
