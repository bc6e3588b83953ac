//! Why a robot or a scene cannot be simulated with contact.

/// A scene that cannot be built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EngineError {
    /// A mesh whose points lie on one line.
    #[error(
        "mesh `{file}` of `{owner}` has no convex hull: its points lie on one line; give it another shape or mesh"
    )]
    Hull {
        /// The link or body.
        owner: String,
        /// The mesh.
        file: String,
    },
    /// A mesh whose triangles cannot be used as a surface.
    #[error("mesh `{file}` of the fixed body `{owner}` is not a usable surface: {reason}")]
    Surface {
        /// The body.
        owner: String,
        /// The mesh.
        file: String,
        /// What the engine found.
        reason: String,
    },
    /// A dynamic body without mass or with a flat inertia tensor.
    #[error(
        "dynamic body `{body}` has a mass of {mass_kg} kg and a least moment of inertia of {least_kg_m2} kg m^2; both must be positive"
    )]
    Massless {
        /// The body.
        body: String,
        /// Its mass \[kg\].
        mass_kg: f64,
        /// Its least principal moment \[kg m²\].
        least_kg_m2: f64,
    },
}
