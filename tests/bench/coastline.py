#!/usr/bin/env python3
# coastline.py - the shorelines of the world as segments: from the binned netCDF file of Debian's gmt-gshhg-full to a .poly file
# SPDX-License-Identifier: MIT
#   coastline.py [binned_GSHHS_f.nc] out.poly
# The file cuts the shorelines at the borders of square bins; a bin's pieces are chains of points in units of 1/65535 of it.
# Points are numbered along the chains, equal ones once, and so are segments; empty segments are left out.
import sys
import netCDF4
import numpy

source = sys.argv[1] if len(sys.argv) > 2 else "/usr/share/gmt-gshhg/binned_GSHHS_f.nc"
data = netCDF4.Dataset(source)
data.set_auto_mask(False)
data.set_auto_scale(False)
v = data.variables


def ints(start):
    name = [k for k in v if k.startswith(start)]
    if len(name) != 1:
        sys.exit("%s: no variable %s*" % (source, start))
    return numpy.atleast_1d(v[name[0]][:]).astype(numpy.int64)


bin_minutes = ints("Bin_size_in_minutes")[0]
bins_x = ints("N_bins_in_360")[0]
first_segment, segments_in_bin = ints("Id_of_first_segment"), ints("N_segments_in_a_bin")
embedded = ints("Embedded_npts_levels")
count, level = embedded >> 9, embedded >> 6 & 7
first_point = ints("Id_of_first_point")
dx, dy = ints("Relative_longitude") & 0xffff, ints("Relative_latitude") & 0xffff

# Level 6, the grounding line of Antarctica, runs across level 5, its ice front.
kept = level != 6

# The bin of each segment, then of each point, in units common to all.
bins = numpy.empty(len(count), numpy.int64)
for b in range(len(segments_in_bin)):
    bins[first_segment[b]:first_segment[b] + segments_in_bin[b]] = b
bins, count, first_point = bins[kept], count[kept], first_point[kept]
point = numpy.repeat(bins, count)
index = numpy.concatenate([numpy.arange(f, f + c) for f, c in zip(first_point, count)])
x = point % bins_x * 65535 + dx[index]
y = (len(segments_in_bin) // bins_x - 1 - point // bins_x) * 65535 + dy[index]

key = x << 32 | y
values, first, inverse = numpy.unique(key, return_index=True, return_inverse=True)
order = numpy.argsort(first)  # by first appearance
number = numpy.empty(len(values), numpy.int64)
number[order] = numpy.arange(len(values))
ids = number[inverse]
chain = numpy.repeat(numpy.arange(len(count)), count)
a, b = ids[:-1], ids[1:]
keep = (chain[:-1] == chain[1:]) & (a != b)
a, b = a[keep], b[keep]
pair = numpy.minimum(a, b) << 32 | numpy.maximum(a, b)
once = numpy.sort(numpy.unique(pair, return_index=True)[1])
a, b = a[once], b[once]

scale = bin_minutes / 60 / 65535
with open(sys.argv[-1], "w") as out:
    out.write("%d 2 0 0\n" % len(values))
    xs, ys = x[first[order]] * scale, y[first[order]] * scale - 90
    out.write("".join("%d %.9f %.9f\n" % p for p in zip(range(len(values)), xs, ys)))
    out.write("%d 0\n" % len(a))
    out.write("".join("%d %d %d\n" % s for s in zip(range(len(a)), a, b)))
    out.write("0\n")
print("%d points, %d segments" % (len(values), len(a)))
