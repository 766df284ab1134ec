#!/usr/bin/env bash
# One would guess: the structure of a tree of arrays (PyTreeDef), which can be pickled, can be read by a later JAX.
# What happens: the pickle names the private module of jaxlib that made it. JAX 0.5.3 writes
# jaxlib.xla_extension.pytree; JAX 0.10.2 has no such module, and reading raises ModuleNotFoundError.
# Where it bites: caches, checkpoints and job queues that keep a structure beside its arrays outlive no such upgrade.
# A tree of plain placeholders, whose structure is taken again after reading, does.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
for version in 0.5.3 0.10.2; do
  python3 -m venv "jax-$version"
  "jax-$version/bin/pip" install -q --disable-pip-version-check "jax==$version" "jaxlib==$version" "numpy==2.4.6"
done
jax-0.5.3/bin/python - <<'PY'
import pickle

import jax

structure = jax.tree.structure({"a": 1, "b": (2, 3)})
print(f"JAX {jax.__version__} writes a {type(structure).__module__}.{type(structure).__name__}")
with open("structure", "wb") as file:
    pickle.dump(structure, file)
assert pickle.loads(pickle.dumps(structure)) == structure
PY
jax-0.10.2/bin/python - <<'PY'
import pickle
import sys

import jax

raised = ""
try:
    with open("structure", "rb") as file:
        pickle.load(file)
except ModuleNotFoundError as error:
    raised = str(error)
own = jax.tree.structure({"a": 1})
print(f"JAX {jax.__version__} has {type(own).__module__}.{type(own).__name__}; reading says: {raised or 'nothing'}")
sys.exit("jaxlib.xla_extension" not in raised)
PY
