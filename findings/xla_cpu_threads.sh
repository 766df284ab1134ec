#!/usr/bin/env bash
# One would guess: a process is kept from XLA's threads on a CPU as many projects do it, with XLA_FLAGS
# "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1", or with OMP_NUM_THREADS=1.
# What happens: neither changes the number of XLA's threads; the second word of the flags is passed over without a
# word. The variable PJRT_NPROC, or else NPROC, does, as it is when JAX first computes.
# Where it bites: many processes on few cores, each with as many threads as cores. XLA hands small parts of a program
# to these threads, so each part waits for a free core. NPROC, which build scripts set, has a side effect on JAX.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/pip install -q --disable-pip-version-check "jax==0.10.2" "jaxlib==0.10.2" "numpy==2.4.6"
cat > threads.py <<'PY'
import pathlib

import jax

jax.block_until_ready(jax.jit(lambda a: a @ a)(jax.numpy.ones((300, 300))))
names = [file.read_text().strip() for file in pathlib.Path("/proc/self/task").glob("*/comm")]
print(names.count("tf_XLAEigen"))
PY
unset NPROC PJRT_NPROC XLA_FLAGS OMP_NUM_THREADS
plain=$(env/bin/python threads.py)
flags=$(XLA_FLAGS="--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1" env/bin/python threads.py)
openmp=$(OMP_NUM_THREADS=1 env/bin/python threads.py)
more=$((plain + 2))
nproc=$(NPROC=$more env/bin/python threads.py)
pjrt=$(PJRT_NPROC=1 NPROC=$more env/bin/python threads.py)
echo "JAX 0.10.2, threads of XLA: $plain; with the flags $flags, OMP_NUM_THREADS=1 $openmp"
echo "NPROC=$more $nproc, PJRT_NPROC=1 beside it $pjrt"
[ "$flags" = "$plain" ] && [ "$openmp" = "$plain" ] && [ "$nproc" = "$more" ] && [ "$pjrt" = 1 ]
