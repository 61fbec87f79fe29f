//! Error metrics and measurements
