//! Air, and how it drags on the bodies of a scene and the links of a robot.

use nalgebra::Vector3;

/// Density of dry air at 15 °C at sea level, where nothing else is stated \[kg/m³\]; source: ISO 2533:1975.
pub const AIR_DENSITY_KG_M3: f64 = 1.225;

/// How a body or link resists the air, the same from every side; the force acts at its centre of mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drag {
    /// Area that meets the air \[m²\].
    pub area_m2: f64,
    /// Drag coefficient, a ratio of pressures.
    pub coefficient: f64,
}

impl Drag {
    /// The force of air that passes at `air_past_body_m_s`, in the axes of that velocity \[N\]: `½ ρ c A |v| v`.
    pub fn force_n(
        &self,
        air_density_kg_m3: f64,
        air_past_body_m_s: &Vector3<f64>,
    ) -> Vector3<f64> {
        let half_rho_c_a = 0.5 * air_density_kg_m3 * self.coefficient * self.area_m2;
        air_past_body_m_s * (half_rho_c_a * air_past_body_m_s.norm())
    }
}

/// The air at one time, the same everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AirNow {
    /// Its density \[kg/m³\].
    pub density_kg_m3: f64,
    /// Its velocity, gusts included, world axes \[m/s\].
    pub velocity_m_s: Vector3<f64>,
}

impl AirNow {
    /// The force on something that moves at `v_in_world` \[m/s\], world axes \[N\].
    pub fn drag_n(&self, drag: &Drag, v_in_world: &Vector3<f64>) -> Vector3<f64> {
        drag.force_n(self.density_kg_m3, &(self.velocity_m_s - v_in_world))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drag_by_hand() {
        let drag = Drag {
            area_m2: 0.5,
            coefficient: 0.8,
        };
        // ½ 1.2 0.8 0.5 = 0.24; |v| = 5
        let force = drag.force_n(1.2, &Vector3::new(3.0, 0.0, -4.0));
        assert!((force - Vector3::new(3.6, 0.0, -4.8)).norm() < 1e-15);
        assert_eq!(drag.force_n(1.2, &Vector3::zeros()), Vector3::zeros());
        // the same air seen from something that moves
        let air = AirNow {
            density_kg_m3: 1.2,
            velocity_m_s: Vector3::new(1.0, 0.0, 0.0),
        };
        let force = air.drag_n(&drag, &Vector3::new(-2.0, 0.0, 4.0));
        assert!((force - Vector3::new(3.6, 0.0, -4.8)).norm() < 1e-15);
    }
}
