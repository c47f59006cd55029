#include "core/physics/drift_model.hpp"

namespace drift {

DRIFT_SELDOM(double, );
DRIFT_SELDOM(Dual<8>, );
DRIFT_SELDOM(Dual<15>, );

}  // namespace drift
