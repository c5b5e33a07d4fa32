#pragma once

namespace catena {

/// Throws InputError where this process is one of several that mpirun or srun started together, of which a
/// build without MPI knows nothing: each would search all, and write the same files.
void require_alone();

}  // namespace catena
