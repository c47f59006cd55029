#!/usr/bin/env bash
#SBATCH --ntasks=64 --cpus-per-task=1 --time=01:00:00
# One study over MPI ranks that take blocks of runs as they come.
#
#   sbatch configs/cluster/slurm_mpi.sh STUDY.toml RESULTS
#
# Open MPI and Slurm must agree on PMIx: `srun --mpi=list` says whether Slurm has it.
exec srun --mpi=pmix "${DRIFTSCOPE:-driftscope}" run "$1" -o "$2" --threads 1 --max-wall "${MAX_WALL:-55m}" --progress plain
