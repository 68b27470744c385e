# Modes by SciPy: python3 scipy_modes.py STIFFNESS MASS COUNT, both matrices in the Matrix Market format.
# Prints: version, seconds, largest relative residual, modes found, the highest eigenvalue.
import sys
import time

try:
    import numpy as np
    import scipy
    from scipy.io import mmread
    from scipy.sparse.linalg import eigsh
except ImportError as error:
    sys.exit(f"{error}")

stiffness, mass = (mmread(path).tocsc() for path in sys.argv[1:3])
count = int(sys.argv[3])
start = time.perf_counter()
values, vectors = eigsh(stiffness, k=count, M=mass, sigma=0)
seconds = time.perf_counter() - start
by_mass = mass @ vectors
left = stiffness @ vectors - by_mass * values
residuals = np.linalg.norm(left, axis=0) / np.linalg.norm(by_mass * values, axis=0)
print(scipy.__version__, seconds, residuals.max(), len(values), values.max())
