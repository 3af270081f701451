"""A model of the cost of a Newton iteration on many ranks, fitted to the work of 1 to 4 ranks, and its predictions."""
import numpy

from . import scenes
from .runs import Samples, number

# Assumed of a cluster's network: the time of a message between two machines [s], and a machine's bandwidth [byte/s].
MESSAGE, BANDWIDTH = 2e-6, 10e9
# The number of sums over all ranks in an iteration: one for the interface and two for norms.
SUMS = 3


def parts(laboratory, nodes, branches, counts):
    """@return the figures of yardstick_parts for each number of parts, as {name: value}"""
    done, _ = laboratory.execute([str(laboratory.program.parent / "yardstick_parts"), str(nodes), str(branches),
                                  *map(str, counts)])
    return [{key: float(value) for key, value in (pair.split("=") for pair in line.split())}
            for line in done.stdout.splitlines()]


def elimination(laboratory, page, sizes):
    """@return the time of a node, and of each block product beyond the node's first [s]"""
    page.write("\nFactoring and solving of the part that costs most, on one core:\n")
    rows, work, seconds = [], [], []
    for nodes, branches in sizes:
        for found in parts(laboratory, nodes, branches, (1, 2, 3, 4)):
            further = (found["products_per_node"] - 1) * found["part_nodes"]
            work.append([found["part_nodes"], further])
            seconds.append(1e-6 * found["part_us"])
            rows.append([nodes, branches, int(found["parts"]), int(found["part_nodes"]), found["products_per_node"],
                         int(found["interface_nodes"]), number(found["part_us"])])
    page.table(["nodes", "branches", "parts", "nodes of the part", "products a node", "interface nodes", "us"], rows)
    weights = 1 / numpy.array(seconds)
    found = numpy.linalg.lstsq(numpy.array(work) * weights[:, None], numpy.ones(len(work)), rcond=None)[0]
    misfit = numpy.abs((numpy.array(work) * weights[:, None]) @ found - 1).max()
    page.write(f"\nFitted: {1e9 * found[0]:.0f} ns a node and {1e9 * found[1]:.0f} ns for each further block product, "
               f"off by at most {100 * misfit:.0f} %.")
    return found


def iterations(laboratory, page, counts):
    """@return the time of a node in the largest array, and the time that an iteration in the smallest array waits on
    two ranks [s]"""
    page.write("\nWhole iterations, wall time:\n")
    rows, times = [], {}
    for elements, steps in counts.items():
        scene = scenes.array(elements)
        pairs = laboratory.repeat(lambda: [laboratory.stepping(scene, steps, ranks=ranks) for ranks in (1, 2)])
        times[elements] = [Samples(pair[i].seconds("wall") / pair[i].newton for pair in pairs).least for i in (0, 1)]
        one, two = times[elements]
        rows.append([elements, number(1e6 * one), number(1e6 * two), number(1e6 * (two - one / 2))])
    page.table(["elements", "1 rank [us]", "2 ranks [us]", "2 ranks beyond half of 1 [us]"], rows)
    largest, smallest = max(times), min(times)
    return times[largest][0] / largest, max(0, times[smallest][1] - times[smallest][0] / 2)


def predict(page, found, elements, node, further, waiting):
    """A table row with the prediction for `elements` elements, from the parts of a smaller array."""
    ranks, interface = found["parts"], found["interface_nodes"]
    share = elements / ranks
    own = share * (node + (found["products_per_node"] - 1) * further)
    shared = 1e-6 * found["interface_us"]
    stages = numpy.log2(ranks)
    sums = SUMS * stages * MESSAGE + 2e3 * found["sum_kB"] / BANDWIDTH
    total = own + shared + sums + waiting
    return [int(ranks), number(share), int(interface), number(1e3 * own), number(1e3 * shared), number(1e3 * sums),
            number(1e3 * total), f"{100 * elements * node / ranks / total:.0f} %"]


def model(laboratory, page, counts, sizes, large, elements):
    """@param counts  {elements: steps} of real runs
    @param sizes  (nodes, branches) of the arrays whose parts are measured
    @param large  (nodes, branches, numbers of parts) of the array whose interfaces the predictions use"""
    page.heading("8. The cost of a Newton iteration on many ranks")
    node, waiting = iterations(laboratory, page, counts)
    _, further = elimination(laboratory, page, sizes)
    nodes, branches, ranks = large
    page.write(f"\nPredicted for {elements:.0e} elements with {branches} branches for {nodes} nodes: own work = share x "
               f"({1e9 * node:.0f} ns + further products x {1e9 * further:.0f} ns); interface and sum as measured for "
               f"{nodes} nodes in as many parts; {SUMS} sums of {1e6 * MESSAGE:.0f} us a stage and "
               f"{BANDWIDTH / 1e9:.0f} GB/s, which are assumed; {1e6 * waiting:.0f} us as on two ranks here.\n")
    rows = [predict(page, found, elements, node, further, waiting)
            for found in parts(laboratory, nodes, branches, ranks)]
    page.table(["ranks", "nodes a rank", "interface nodes", "own work [ms]", "interface [ms]", "sums [ms]", "total [ms]",
                "efficiency"], rows)
