"""The scripts of this folder share mpirun's environment, scenes, and the arguments that ctest gives."""
import argparse
import os
import pathlib
import shutil

# tests/parallel/resume_test.cpp runs these scenes, too.
SCENES = pathlib.Path(__file__).resolve().parent / "scenes"

# mpirun may run as root, with more ranks than cores, on a busy machine.  ctest sets the same variables.
ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1",
               "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe", "OMPI_MCA_mpi_yield_when_idle": "1",
               "OMPI_MCA_btl_vader_single_copy_mechanism": "none", "HWLOC_COMPONENTS": "-gl", **os.environ}


def arguments(description):
    """Reads --program and --scratch.  The scratch folder is new and empty."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--program", required=True)
    parser.add_argument("--scratch", type=pathlib.Path, required=True)
    given = parser.parse_args()
    shutil.rmtree(given.scratch, ignore_errors=True)
    given.scratch.mkdir(parents=True)
    return given
