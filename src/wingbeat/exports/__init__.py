"""An orbit's gait for other tools: robot controllers, MATLAB and Simulink, motion capture, MuJoCo."""
