//! Lights and light selection
