"""One period flown: by few steps with exact derivatives, by the certifier, and as a beat to read quantities off."""
