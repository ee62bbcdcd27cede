"""Box plots as in Tables 3.5 and 3.8 of the ETH thesis, from the samples of studies.

python3 box_plot.py proposed-a.out proposed-r.out ...     prints min, Q1, median, Q3, max of the cone form, and
                                                          draws box_plot.png where matplotlib is installed.
"""
import glob
import os
import sys

import h5py
import numpy

NAME = "characteristics/cone.equivalent_form"


def samples(folder):
    parts = sorted(glob.glob(os.path.join(folder, "samples", "part-*.h5")))
    if not parts:
        sys.exit(f"{folder}: there are no samples; run frustum study with --out {folder}")
    columns = []
    for part in parts:
        with h5py.File(part, "r") as file:
            columns.append(file[NAME][:])
    return numpy.concatenate(columns)


folders = sys.argv[1:] or sys.exit(__doc__)
values = [samples(folder) for folder in folders]
print(f"{'cone form, um':<28} {'min':>8} {'Q1':>8} {'median':>8} {'Q3':>8} {'max':>8}")
for folder, column in zip(folders, values):
    numbers = numpy.quantile(column, [0, 0.25, 0.5, 0.75, 1])
    print(f"{os.path.basename(os.path.normpath(folder)):<28} " + " ".join(f"{n:8.3f}" for n in numbers))
try:
    import matplotlib.pyplot as plot
except ImportError:
    sys.exit(0)
figure, axes = plot.subplots()
axes.boxplot(values, whis=(0, 100))
axes.set_xticks(range(1, len(folders) + 1), [os.path.basename(os.path.normpath(f)) for f in folders])
axes.set_ylabel("cone form, um")
figure.savefig("box_plot.png", dpi=150)
