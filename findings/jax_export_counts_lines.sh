#!/usr/bin/env bash
# One would guess: jax.export gives the same bytes for the same function, so their digest can name what was exported.
# What happens: the bytes hold file and line of each operation. A comment above the function, or a copy of the file in
# another folder, changes them, although the computation is the same. Stripped of these places, they are equal.
# Where it bites: caches and build systems keyed by the artifact's digest, and artifacts that tell where they were made.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/pip install -q --disable-pip-version-check "jax==0.10.2" "jaxlib==0.10.2" "numpy==2.4.6" "flatbuffers==25.12.19"
cat > model.py <<'PY'
import hashlib

import jax
import jax.export
import jax.numpy as jnp
from jax.interpreters.mlir import make_ir_context
from jaxlib.mlir import ir, passmanager


def drag(speed):
    return 0.5 * 1.2 * speed**2 * jnp.cos(speed)


made = jax.export.export(jax.jit(drag))(jax.ShapeDtypeStruct((3,), jnp.float32))
with make_ir_context():
    module = ir.Module.parse(made.mlir_module())
    passmanager.PassManager.parse("builtin.module(strip-debuginfo)").run(module.operation)
    stripped = str(module)
print(*(hashlib.sha256(text).hexdigest()[:12] for text in (bytes(made.serialize()), stripped.encode())), jax.__version__)
PY
mkdir elsewhere
cp model.py elsewhere/model.py
{ echo "# A comment."; cat model.py; } > commented.py
first=$(env/bin/python model.py)
again=$(env/bin/python model.py)
commented=$(env/bin/python commented.py)
moved=$(env/bin/python elsewhere/model.py)
echo "JAX ${first##* }: digest of the bytes, digest of the program without places"
printf '%-22s %s\n' "first" "$first" "run again" "$again" "with a comment" "$commented" "in another folder" "$moved"
digest() { cut -d' ' -f"$1" <<< "$2"; }
[ "$(digest 1 "$first")" = "$(digest 1 "$again")" ]
[ "$(digest 1 "$first")" != "$(digest 1 "$commented")" ]
[ "$(digest 1 "$first")" != "$(digest 1 "$moved")" ]
[ "$(digest 2 "$first")" = "$(digest 2 "$commented")" ]
[ "$(digest 2 "$first")" = "$(digest 2 "$moved")" ]
