"""The explorer in the browser: `serve` answers until it is interrupted. It needs the extra ``app``."""
