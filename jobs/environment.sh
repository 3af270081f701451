# Sourced by the other scripts: Open MPI as root, with more ranks than cores, and inside containers.
export OMPI_ALLOW_RUN_AS_ROOT=1
export OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_mpi_yield_when_idle=1
export OMPI_MCA_btl_vader_single_copy_mechanism=none
# Open MPI 5 has its own word for oversubscribe; 4 does not read it.
export PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
# hwloc would ask a virtual X server that a picture script is about to stop.
export HWLOC_COMPONENTS=-gl
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1}
