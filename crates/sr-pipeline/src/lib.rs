//! The seam: schedules, plug-ins, integrator registration, the pass loop
