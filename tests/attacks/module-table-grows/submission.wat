(module
  (table $t 1 funcref)
  (func (export "km_forward_kinematics") (param $robot i32) (param $q i32) (param $position i32) 
    (loop $again (drop (table.grow $t (ref.null func) (i32.const 1000))) (br $again)))
  (memory (export "memory") 2)
  (func (export "km_version") (result i32) (i32.const 1))
  (func (export "km_buffer") (param i32) (result i32) (i32.const 1024)))
