"""Worker processes: how they are talked to, which core they keep to, what they leave behind when they end."""
