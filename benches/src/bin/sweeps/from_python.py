"""Times of a sweep over clearances and loads, on threads and on a cluster of processes: a line each.

python from_python.py CLEARANCES LOADS STEPS WORKERS
"""

import sys
import time

import numpy as np

import whirl


def main():
    clearances, loads, steps, workers = map(int, sys.argv[1:])
    case = {"include": "hu2003-5.toml", "march": {"steps": steps}}
    vary = {
        "springs.radial_clearance": [f"{own:.12g} um" for own in np.linspace(20, 60, clearances)],
        "load.1.force": [f"{own:.12g} N" for own in np.linspace(500, 1500, loads)],
    }

    def timed(what, **more):
        start = time.perf_counter()
        sweep = whirl.sweep(case, vary, keep_histories=False, **more)
        assert all(own.error is None for own in sweep)
        print(f"{what}\t{time.perf_counter() - start:.3f}", flush=True)

    # Bodies are there before anything is timed.
    whirl.Case({**case, "march": {"steps": 2}}).run()
    start = time.process_time()
    for clearance in vary["springs.radial_clearance"]:
        for _ in range(loads):
            own = {"march": {"steps": 2}, "springs": {"radial_clearance": clearance}}
            whirl.Case({**case, **own}).run()
    alone = (time.process_time() - start) / (clearances * loads)
    print(f"two steps a point, one run after the other\t{alone:.5f}", flush=True)
    timed(f"{workers} threads", workers=workers)
    try:
        from dask.distributed import Client, LocalCluster
    except ImportError:
        return
    with (
        LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        # The workers have imported what they need.
        whirl.sweep(case, {"march.steps": [2, 3]}, client=client)
        timed(f"Dask with {workers} processes", client=client)


if __name__ == "__main__":
    main()
