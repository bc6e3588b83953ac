(module
    (memory (export "memory") 2)
    (func (export "km_version") (result i32) i32.const 1)
    (func (export "km_buffer") (param i32) (result i32) i32.const 1024)
    (func (export "km_forward_kinematics") (param i32 i32 i32))
    (func (export "km_inverse_kinematics") (param i32 i32 i32 i32) (result i32) i32.const 0)
    (func (export "km_control") (param i32 i32))
    )
